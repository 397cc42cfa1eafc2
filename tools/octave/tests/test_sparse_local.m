function test_sparse_local(varargin)
%TEST_SPARSE_LOCAL  Tests of the classes, of the mex file under them, and of the examples.
%
%   Prints each test, and at the end `N passed, N failed`; fails if a test did. make test-octave

    tests = {@full_solves, @local_solves, @entries_of_the_inverse, @factors_as_matrices, ...
             @other_numbers, @changes, @rows_held, @indefinite, @singular, @options, @messages, @names, ...
             @wrong_arguments, @lifetimes, @quadratic_energies, @help_texts, @readme, ...
             @heat_example};
    passed = 0;
    failed = 0;
    for k = 1:numel(tests)
        name = func2str(tests{k});
        before = sparse_local_mex('live');
        try
            tests{k}();
            assert(sparse_local_mex('live') == before, 'an object is left');
            passed = passed + 1;
            fprintf('ok       %s\n', name);
        catch e
            failed = failed + 1;
            fprintf('FAILED   %s: %s\n', name, e.message);
            for s = 1:numel(e.stack)
                fprintf('    %s, line %d\n', e.stack(s).name, e.stack(s).line);
            end
        end
    end
    fprintf('%d passed, %d failed\n', passed, failed);
    if failed > 0, error('test_sparse_local:failed', '%d tests failed', failed); end
end

% ---- what tests share ----

function A = grid_laplacian(side, shift)
    % The Laplacian of a square grid, plus shift times the identity.
    e = ones(side, 1);
    T = spdiags([-e, 2 * e, -e], -1:1, side, side);
    T(1, 1) = 1;
    T(side, side) = 1;
    I = speye(side);
    A = kron(T, I) + kron(I, T) + shift * speye(side^2);
end

function near(x, y, bound)
    % x and y agree up to bound, relative to the largest number of y.
    assert(isequal(size(x), size(y)), 'sizes differ');
    x = full(x);
    y = full(y);
    gap = max(abs(x(:) - y(:)));
    if isempty(gap), gap = 0; end
    assert(gap <= bound * max([1; abs(y(:))]), sprintf('numbers differ by %g', gap));
end

function refused(id, text, call)
    % call fails with an identifier, and with a text in its message.
    try
        call();
    catch e
        assert(strcmp(e.identifier, ['sparse_local:', id]), [e.identifier, ': ', e.message]);
        assert(isempty(text) || ~isempty(strfind(e.message, text)), e.message);
        return;
    end
    error('test:success', 'a call succeeds that should be refused with %s', id);
end

% ---- solves ----

function full_solves()
    A = grid_laplacian(20, 0.1);
    n = size(A, 1);
    b = sin((1:n)' * (1:3));
    for F = {sparse_local(A), sparse_local(tril(A)), sparse_local(triu(A))}
        near(F{1} \ b, A \ b, 1e-12);
        assert(F{1}.n == n);
    end
    F = sparse_local(A);
    near(F.solve(b(:, 1)), A \ b(:, 1), 1e-12);
    near(F \ sparse([4 9], [1 1], [2 3], n, 1), A \ full(sparse([4 9], [1 1], [2 3], n, 1)), 1e-12);
    near(F \ (b(:, 1) + 1i * b(:, 2)), A \ (b(:, 1) + 1i * b(:, 2)), 1e-12);
    near(F \ single(b), A \ double(single(b)), 1e-12);
    assert(isequal(size(F \ zeros(n, 0)), [n, 0]));
    small = sparse_local(4); % a full matrix is taken, too
    assert(small \ 8 == 2);
    none = sparse_local(sparse(0, 0));
    assert(isequal(size(none \ zeros(0, 2)), [0, 2]));
    text = evalc('disp(F)');
    assert(~isempty(strfind(text, '400 rows')));
end

function local_solves()
    A = grid_laplacian(20, 0.1);
    n = size(A, 1);
    F = sparse_local(A);
    I = [7, 130, 7];
    J = [1, 399, 130];
    b = [1; 2; 3]; % those of a row that is given twice add up
    whole = zeros(n, 1);
    whole(7) = 4;
    whole(130) = 2;
    x = F \ whole;
    assert(isequal(F.local(I, b, J), x(J)));
    assert(isequal(F.local(I, b', J), x(J))); % a row is taken for a column
    assert(isequal(F.local(':', whole, J), x(J)));
    assert(isequal(F.local(I, b, ':'), x));
    mask = false(n, 1);
    mask([130, 7]) = true;
    assert(isequal(F.local(mask, [4; 2], mask), x([7, 130])));
    assert(isequal(F.local(int32(I), b, uint8([1, 130])), x([1, 130])));
    assert(isempty(F.local([], zeros(0, 1), [])));
    assert(isequal(F.local([], zeros(0, 1), 5), 0));
    P = F.plan(I, J);
    assert(isequal(P.solve(b), x(J)));
    near(P.solve([b, -b]), [x(J), -x(J)], 1e-14);
    Q = F.plan(':', 17);
    assert(isequal(Q.solve(whole), x(17)));
    assert(~isempty(strfind(evalc('disp(P)'), 'a plan')));
end

% ---- the factor ----

function entries_of_the_inverse()
    A = grid_laplacian(9, 0.3);
    n = size(A, 1);
    F = sparse_local(A);
    Z = inv(full(A));
    near(F.diagonal(), diag(Z), 1e-12);
    near(F.diagonal([5, 3, 5]), diag(Z([5, 3, 5], [5, 3, 5])), 1e-12);
    near(F.pairs([1, 2], [80, 3]), [Z(1, 80); Z(2, 3)], 1e-12);
    near(F.block([4, 2], [1, 9, 81]), Z([4, 2], [1, 9, 81]), 1e-12);
    near(F.block(1:n, 1:n), Z, 1e-12);
end

function factors_as_matrices()
    A = grid_laplacian(9, 0.3);
    F = sparse_local(A);
    [l, s] = F.logdet();
    near(l, log(det(full(A))), 1e-12);
    assert(s == 1);
    [L, D, p] = F.factors();
    near(L * D * L', A(p, p), 1e-13);
    assert(istril(L) && isdiag(D));
    s = F.info();
    assert(s.n == 81 && s.positive == 81 && s.negative == 0 && s.null == 0 && s.growth < 3);
    assert(s.nnz_l >= nnz(L) && s.bytes > 8 * nnz(L) && s.pivot_min > 0 && s.threads >= 1);
    K = [A, speye(81, 2); speye(2, 81), sparse(2, 2)];
    F = sparse_local(K, 'pivoted', true);
    [L, D, p] = F.factors();
    near(L * D * L', K(p, p), 1e-12);
    [l, s] = F.logdet();
    assert(s == sign(det(full(K))) && isfinite(l));
    B = grid_laplacian(5, 0);
    F = sparse_local(B, 'null_pivots', 'skip');
    [L, D, p] = F.factors();
    near(L * D * L', B(p, p), 1e-13);
end

function other_numbers()
    A = grid_laplacian(12, 0.1);
    n = size(A, 1);
    b = cos(1:n)';
    F = sparse_local(A);
    P = F.plan(':', [3, 50]);
    A = A + spdiags((1:n)', 0, n, n);
    F.refactor(A);
    x = A \ b;
    near(F \ b, x, 1e-12);
    near(P.solve(b), x([3, 50]), 1e-12);
    C = A;
    C([1, n], [n, 1]) = C([1, n], [n, 1]) + [1, 0; 0, 1];
    refused('other_pattern', 'more or fewer entries', @() F.refactor(C));
    near(F \ b, x, 1e-12); % as it was
    refused('not_finite', '(row 7, column 7', @() F.refactor(A + sparse(7, 7, NaN, n, n)));
    refused('stale', '', @() F.solve(b));
    F.refactor(A);
    near(F \ b, x, 1e-12);
end

function changes()
    A = grid_laplacian(12, 0.1);
    n = size(A, 1);
    b = cos(1:n)';
    F = sparse_local(A);
    V = sparse([3, 4, 30], [1, 1, 2], [1, -1, 2], n, 2);
    F.rank_update(V);
    B = A + V * V';
    near(F \ b, B \ b, 1e-12);
    F.downdate(V);
    near(F \ b, A \ b, 1e-12);
    F.rank_update(full(V), [2; 0.5]);
    near(F \ b, (A + V * diag([2, 0.5]) * V') \ b, 1e-12);
    F.rank_update(V, [-2; -0.5]);
    C = A;
    C(9, 9) = 7;
    C(9, 10) = -2;
    C(10, 9) = -2;
    F.change_entries(C, A);
    near(F \ b, C \ b, 1e-12);
    F.change_entries(A, C);
    near(F \ b, A \ b, 1e-12);
    refused('pivot', 'row', @() F.downdate(sparse(5, 1, 100, n, 1)));
    refused('other_pattern', 'row', @() F.rank_update(sparse([1, n], [1, 1], [1, 1], n, 1)));
    near(F \ b, A \ b, 1e-12);
end

function rows_held()
    A = grid_laplacian(12, 0.1);
    n = size(A, 1);
    b = cos(1:n)';
    F = sparse_local(A);
    P = F.constraints([5, 70]);
    x = P.solve(b, [1; 2]);
    near(x([5, 70]), [1; 2], 1e-12);
    free = setdiff(1:n, [5, 70]);
    near(x(free), A(free, free) \ (b(free) - A(free, [5, 70]) * [1; 2]), 1e-12);
    P.add(9);
    assert(P.count == 3);
    P.release([1, 3]);
    assert(P.count == 1);
    R = F.constraints();
    assert(R.count == 0);
    near(R.solve(b, zeros(0, 1)), F \ b, 1e-12);
    R.add([5, 70]);
    near(R.solve(b, [1; 2]), x, 1e-12);
    x = P.solve([b, -b], [3, -3]);
    near(x(70, :), [3, -3], 1e-12);
    Q = F.plan([1, 2], [71, 70]);
    z = F \ accumarray(70, 1, [n, 1]);
    near(P.solve([0; 0], 4, Q), 4 * z([71, 70]) / z(70), 1e-12);
    refused('pivot', '(row 70)', @() P.add(70));
    F.refactor(2 * A);
    refused('stale', 'P.refactor()', @() P.solve(b, 3));
    P.refactor();
    y = P.solve(2 * b, 3);
    near(y, x(:, 1), 1e-12);
    assert(~isempty(strfind(evalc('disp(P)'), '1 pins')));
    refused('argument', 'rows, not 1', @() P.solve(b, [1; 2]));
    refused('argument', 'as many columns', @() P.solve(b, [1, 2]));
end

function indefinite()
    A = grid_laplacian(10, 0.1);
    n = size(A, 1);
    E = sparse([1, 1, 2], [3, 4, 9], [1, -1, 1], 2, n);
    K = [A, E'; E, sparse(2, 2)];
    b = cos(1:n + 2)';
    x = K \ b;
    F = sparse_local(K, 'pivoted', true);
    near(F \ b, x, 1e-11);
    s = F.info();
    assert(s.negative == 2);
    assert(F.rcond(K) > 1e-6 && F.rcond(K) < 1);
    F = sparse_local(K, 'regularization', 1e-8, 'signs', [ones(n, 1); -1; -1]);
    [y, e] = F.refine(K, b);
    near(y, x, 1e-11);
    assert(e < 1e-13);
    refused('unsupported', '2x2', @() sparse_local([0, 1; 1, 0], 'pivoted', true).diagonal());
end

function singular()
    A = grid_laplacian(10, 0);
    n = size(A, 1);
    b = zeros(n, 1);
    b([4, 90]) = [1, -1];
    refused('pivot', '(row ', @() sparse_local(A));
    F = sparse_local(A, 'null_pivots', 'skip');
    x = F \ b;
    near(A * x, b, 1e-12);
    refused('inconsistent', '', @() F.solve(ones(n, 1)));
    m = 1 + mod((1:n)', 3);
    F = sparse_local(A, 'null_pivots', 'skip', 'mass', m);
    x = F \ b;
    near(A * x, b, 1e-12);
    near(m' * x, 0, 1e-10);
    S = spdiags(1 ./ (1:n)', 0, n, n); % another null vector
    F = sparse_local(S * A * S, 'null_pivots', 'skip', 'null_vector', (1:n)');
    near(S * A * (S * (F \ (S * b))), S * b, 1e-10);
end

function options()
    A = grid_laplacian(8, 0.1);
    n = size(A, 1);
    b = cos(1:n)';
    x = A \ b;
    sets = {{'ordering', 'nd'}, {'ordering', 'mindeg'}, {'ordering', 'natural'}, ...
            {'perm', n:-1:1}, ...
            {'purpose', 'one factor'}, {'purpose', 'many solves'}, {'triangle', 'upper'}, ...
            {'triangle', 'lower'}, {'triangle', 'auto'}, {'block_size', 2}, {'threads', 2}, ...
            {'definite', true}, {'definite', 0}, {'null_tolerance', -1}, {'growth_limit', 100}, ...
            {'error_limit', 1e-6}, {'consistency_tolerance', 1e-3}, {'storage', 'double'}};
    for k = 1:numel(sets)
        near(sparse_local(A, sets{k}{:}) \ b, x, 1e-12);
    end
    near(sparse_local(A, 'storage', 'float') \ b, x, 1e-4);
    upper = sparse_local(triu(A) + 2 * tril(A, -1), 'triangle', 'upper');
    near(upper \ b, x, 1e-12);
    refused('pivot', 'row', @() sparse_local(-A, 'definite', true));
    refused('inaccurate', 'growth', @() sparse_local(A, 'growth_limit', 0.5));
    refused('argument', 'ordering is one of', @() sparse_local(A, 'ordering', 'amd'));
    refused('argument', 'ordering is one of', @() sparse_local(A, 'ordering', 3));
    refused('argument', 'excludes', @() sparse_local(A, 'ordering', 'nd', 'perm', n:-1:1));
    refused('argument', 'excludes', @() sparse_local(A, 'perm', n:-1:1, 'ordering', 'nd'));
    refused('argument', 'auto|lower|upper', @() sparse_local(A, 'triangle', 'both'));
    refused('argument', 'one number', @() sparse_local(A, 'growth_limit', [1, 2]));
    refused('argument', 'whole number', @() sparse_local(A, 'threads', 1.5));
    refused('argument', 'option 2', @() sparse_local(A, 'threads', 1, 'color', 2));
    refused('argument', 'option 1', @() sparse_local(A, 3, 4));
    refused('argument', 'pairs', @() sparse_local(A, 'threads'));
    refused('argument', 'perm', @() sparse_local(A, 'perm', [1, 2]));
    refused('argument', '(row 2)', @() sparse_local(A, 'perm', ones(1, n)));
    refused('argument', 'mass has 3 rows', @() sparse_local(A, 'mass', [1; 2; 3]));
end

% ---- refusals ----

function messages()
    A = grid_laplacian(10, 0.1);
    F = sparse_local(A);
    n = size(A, 1);
    refused('argument', '(row 101)', @() F.local(101, 1, 1));
    refused('argument', '(row 105)', @() F.diagonal([1, 105]));
    refused('argument', '(column 200)', @() F.pairs([1, 3], [2, 200]));
    refused('argument', 'whole numbers from 1 on, not 0', @() F.local(0, 1, 1));
    refused('argument', 'not 1.5', @() F.plan(1, 1.5));
    refused('malformed', '(row 5, column 7)', @() sparse_local(A + sparse(5, 7, 1, n, n)));
    refused('malformed', '(row 5, column 6', @() sparse_local(A + sparse(5, 6, 2, n, n)));
    refused('not_finite', '(row 3, column 3', @() sparse_local(A + sparse(3, 3, Inf, n, n)));
    refused('argument', 'square', @() sparse_local(sparse(3, 4)));
    refused('argument', 'complex', @() sparse_local(A * 1i));
    refused('argument', 'b has 3 rows, not 100', @() F.solve([1; 2; 3]));
    refused('argument', 'real doubles', @() F.pairs(1i, 2));
    refused('argument', 'one length', @() F.pairs([1, 2], 1));
    refused('argument', 'one length', @() F.pairs(':', 1));
    refused('argument', 'a set of rows', @() F.block(':', 1));
    refused('argument', 'a set of rows', @() F.constraints(':'));
    G = sparse_local(grid_laplacian(9, 0.1));
    P = G.plan(1, 1);
    refused('mismatch', '', @() sparse_local_mex('plan_solve', F.id, P.id, 1));
    F.close();
    F.close();
    refused('stale', 'closed', @() F.solve(1));
    refused('stale', 'closed', @() F.info());
end

function names()
    % Nothing of C is in any sentence of the library, nor in the errors of wrong uses.
    header = fileread('sparse_local.h');
    header = regexprep(header, '/\*.*?\*/', '', 'dotall');
    enum = regexp(header, 'typedef enum sl_status \{(.*?)\} sl_status;', 'tokens', 'once');
    ids = regexp(enum{1}, '\<SL_(?:ERR_)?(\w+)', 'tokens');
    assert(isequal(sparse_local_mex('statuses'), lower([ids{:}])));
    literals = regexp(header, '"(?:[^"\\\n]|\\.)*"(?:\s*"(?:[^"\\\n]|\\.)*")*', 'match');
    literals = unique(regexprep(literals, '"\s*"|^"|"$', ''));
    literals = literals(cellfun(@(s) any(s == ' ') && ~any(s == '%') && ...
                                isempty(strfind(s, 'sparse_local.h')), literals));
    assert(numel(literals) > 250 && any(strcmp(literals, 'A is not square')));
    impossible = ['NULL|\<ld[a-z] |size|is below 0|is not a value of|^R is B|P\.columns|isa|', ...
                  'allocator|set\.|sl_load|SL_LOAD|a reserved|SL_PART|SL_METIS|SL_GUARANT|', ...
                  'H\.|new_of|region|sl_factor_|sl_selected|sl_fixed|weak'];
    for k = 1:numel(literals)
        own = sparse_local_mex('own_names', [literals{k}, ' (row 3, column 4)']);
        assert(~of_c(own), own);
        assert(strcmp(own(end - 17:end), ' (row 4, column 5)'), own);
        if strcmp(own, 'invalid argument (row 4, column 5)') && ~strcmp(literals{k}, 'invalid argument')
            assert(~isempty(regexp(literals{k}, impossible, 'once')), literals{k});
        end
    end
    assert(of_c('options.mass') && of_c('ldx is short') && of_c('of sl_x') && ~of_c("'mass'"));
    wrong = wrong_uses();
    said = {};
    for k = 1:numel(wrong)
        try
            wrong{k}();
        catch e
            assert(~of_c(e.message), e.message);
            assert(strncmp(e.identifier, 'sparse_local:', 13), [e.identifier, ': ', e.message]);
            said{end + 1} = e.message;
            continue;
        end
        error('test:success', 'wrong use %d succeeds', k);
    end
    assert(numel(unique(said)) > 30);
end

function found = of_c(text)
    found = ~isempty(regexp(text, ['\<(sl|SL|sli|SLI)_\w|\<options\.|\<stats\.|\<NULL\>|', ...
        '\<size_t\>|\<ld[a-z]\>|\<[A-Z]\.(p|i|x|im|columns)\>|\<n_(rows|cols|columns)\>|', ...
        '\<null_vector_count\>|count from 0'], 'once'));
end

function calls = wrong_uses()
    A = grid_laplacian(6, 0.1);
    n = size(A, 1);
    F = sparse_local(A);
    L = grid_laplacian(6, 0);
    S = sparse_local(L, 'null_pivots', 'skip');
    K = sparse([0, 1, 2; 1, 0, 3; 2, 3, 0]);
    Q = sparse_local(K, 'pivoted', true);
    B = A;
    B(7, 7) = -50;
    I = sparse_local(B);
    Z = A;
    Z(3, :) = 0;
    Z(:, 3) = 0;
    Z(3, 3) = 1;
    Z(3, 3) = 0;
    C = sparse_local(A);
    P = C.constraints(3);
    C.refactor(2 * A);
    other = sparse_local(grid_laplacian(5, 1));
    R = other.plan(1, 1);
    E = A;
    E(1, 20) = 0.25;
    E(20, 1) = 0.25;
    closed = sparse_local(A);
    closed.close();
    b = ones(n, 1);
    late = b;
    late(4) = NaN;
    calls = {@() sparse_local(A(:, 1:5)), @() sparse_local(L), @() sparse_local(tril(L)), ...
        @() sparse_local(L, 'pivoted', true), @() sparse_local(K), @() sparse_local(Z), ...
        @() sparse_local(B, 'definite', true), @() sparse_local(B, 'null_pivots', 'skip'), ...
        @() sparse_local(A, 'null_tolerance', 100), @() sparse_local(A, 'null_tolerance', NaN), ...
        @() sparse_local(K + 1e-9 * speye(3), 'growth_limit', 10), ...
        @() sparse_local(K, 'pivoted', true, 'null_pivots', 'skip'), ...
        @() sparse_local(A, 'regularization', 1e-8, 'null_pivots', 'skip'), ...
        @() sparse_local(A, 'regularization', -1), @() sparse_local(A, 'growth_limit', NaN), ...
        @() sparse_local(A, 'error_limit', NaN), @() sparse_local(A, 'block_size', 5), ...
        @() sparse_local(A, 'consistency_tolerance', NaN), @() sparse_local(A, 'perm', ones(n, 1)), ...
        @() sparse_local(L, 'null_pivots', 'skip', 'mass', NaN(n, 1)), ...
        @() sparse_local(L, 'null_pivots', 'skip', 'mass', ones(3, 1)), ...
        @() sparse_local(L, 'null_pivots', 'skip', 'null_vector', ones(n, 33)), ...
        @() sparse_local(L, 'null_pivots', 'skip', 'null_vector', NaN(n, 1)), ...
        @() sparse_local(A * NaN), @() sparse_local(A + sparse(2, 1, 7, n, n)), ...
        @() sparse_local(A, 'ordering', 'no'), @() F.solve(ones(n + 1, 1)), @() F.solve(late), ...
        @() F.local(3, NaN, 4), @() F.local(n + 1, 1, 1), @() F.plan(0, 1), @() S.solve(b), ...
        @() S.local(3, 1, 4), @() F.diagonal(n + 1), @() F.pairs(1, n + 1), ...
        @() F.block(1, n + 1), @() Q.diagonal(1), @() F.refactor(E), @() F.refactor(K), ...
        @() sparse_local_mex('plan_solve', F.id, R.id, 1), @() P.solve(b, 1), ...
        @() F.constraints([3, 3]), @() F.constraints(n + 1), @() I.constraints(1), ...
        @() Q.constraints(1), @() F.rank_update(sparse([1, n], [1, 1], [1, 1], n, 1)), ...
        @() F.rank_update(sparse(n + 1, 1)), @() S.rank_update(sparse(1, 1, 1, n, 1)), ...
        @() Q.rank_update(sparse(1, 1, 1, 3, 1)), @() F.change_entries(E, A), @() F.rcond(K), ...
        @() F.refine(A, late), @() F.refine(A, b, -1), @() closed.solve(b), @() closed.info(), ...
        @() F.downdate(1e3 * sparse(1, 1, 1, n, 1))};
end

function wrong_arguments()
    % Each command of the mex file with arguments of every wrong kind: an error, and no crash.
    commands = {'create', 2; 'refactor', 2; 'solve', 2; 'refine', 4; 'rcond', 2; 'logdet', 1; ...
                'factors', 1; 'info', 1; 'local', 4; 'plan', 3; 'plan_solve', 3; 'diagonal', 2; ...
                'pairs', 3; 'block', 3; 'rank_update', 3; 'change_entries', 5; 'constraints', 1; ...
                'constraints_add', 2; 'constraints_release', 2; 'constraints_refactor', 1; ...
                'constraints_solve', 6};
    things = {[], 'x', {}, {1, 2}, struct('a', 1), single(3), true, 1i, sparse(2), -1, NaN, ...
              1e300, uint8(3), @sin, ones(2, 2, 2)};
    A = grid_laplacian(4, 1);
    F = sparse_local(A);
    good = {F.id, A, 1, 1, 1, 0};
    for k = 1:size(commands, 1)
        for wrong = 0:commands{k, 2}
            for t = 1:numel(things)
                list = good(1:commands{k, 2});
                if strcmp(commands{k, 1}, 'create'), list = {A, {}}; end
                if wrong > 0, list{wrong} = things{t}; end
                try
                    id = sparse_local_mex(commands{k, 1}, list{:});
                    if any(strcmp(commands{k, 1}, {'create', 'plan', 'constraints'}))
                        sparse_local_mex('free', id);
                    end
                catch e
                    assert(~isempty(e.message));
                end
            end
        end
        refused('argument', 'other arguments', @() sparse_local_mex(commands{k, 1}));
    end
    refused('argument', 'no such command', @() sparse_local_mex());
    refused('argument', 'no such command', @() sparse_local_mex(1, 2));
    refused('argument', 'no such command', @() sparse_local_mex('solv', 1));
    for t = 1:numel(things)
        sparse_local_mex('free', things{t});
    end
end

function lifetimes()
    A = grid_laplacian(10, 0.1);
    before = sparse_local_mex('live');
    F = sparse_local(A);
    P = F.plan(1, 1);
    Q = F.constraints(3);
    assert(sparse_local_mex('live') == before + 3);
    x = P.solve(1);
    G = F;
    clear F; % the plan keeps the factor
    assert(P.solve(1) == x);
    clear G;
    assert(P.solve(1) == x);
    clear sparse_local_mex; % is refused while there are objects
    assert(P.solve(1) == x);
    P = [];
    assert(sparse_local_mex('live') == before + 2);
    Q = [];
    assert(sparse_local_mex('live') == before);
    clear sparse_local_mex;
    assert(sparse_local_mex('live') == 0);
    F = sparse_local(A);
    F = sparse_local(2 * A); % the first one is released
    assert(sparse_local_mex('live') == 1);
end

% ---- examples ----

function quadratic_energies()
    A = grid_laplacian(9, 0);
    n = size(A, 1);
    B = [cos(1:n)', sin(1:n)'];
    known = [4, 77, 20];
    Y = [1, 2; 3, 4; 5, 6];
    u = setdiff(1:n, known)';
    [Z, F, Lambda, Lambda_known] = min_quad_with_fixed(A, B, known, Y);
    assert(isequal(Z(known, :), Y) && isempty(Lambda));
    near(2 * A(u, :) * Z + B(u, :), zeros(numel(u), 2), 1e-11);
    near(2 * A(known, :) * Z + B(known, :) + 2 * Lambda_known, zeros(3, 2), 1e-11);
    near(min_quad_with_fixed(A, 2 * B, known, -Y, [], [], F), ...
         min_quad_with_fixed(A, 2 * B, known, -Y), 0);
    near(min_quad_with_fixed(A, [], known, Y(:, 1)), ...
         min_quad_with_fixed(A, 0 * B(:, 1), known, Y(:, 1)), 0);
    mask = false(n, 1);
    mask(known) = true;
    near(min_quad_with_fixed(A, [], mask, Y([1, 3, 2], :)), ...
         min_quad_with_fixed(full(A), [], known, Y), 1e-14);
    % equalities, one of them among known values only
    Aeq = sparse([1, 1, 2, 3], [8, 9, 4, 30], [1, -1, 2, 1], 3, n);
    [Z, F, Lambda] = min_quad_with_fixed(A, B, known, Y, Aeq, [0; 2; 7] * [1, 2]);
    near(Aeq * Z, [0; 2; 7] * [1, 2], 1e-10);
    near(2 * A(u, :) * Z + B(u, :) + 2 * Aeq([1, 3], u)' * Lambda, zeros(numel(u), 2), 1e-10);
    near(min_quad_with_fixed(A, B, known, Y, Aeq, [0; 2; 7] * [1, 2], F), Z, 1e-13);
    try
        min_quad_with_fixed(A, B, known, Y, Aeq, [0; 3; 7] * [1, 1], F);
        error('test:success', 'equalities that do not hold');
    catch e
        assert(strcmp(e.identifier, 'min_quad_with_fixed:blank'), e.message);
    end
    % nothing known, and no equality: a Laplacian alone is singular; with one equality it is not
    b = B(:, 1) - mean(B(:, 1));
    Z = min_quad_with_fixed(A, b, [], [], ones(1, n), 0);
    near(sum(Z), 0, 1e-10);
    free = min_quad_with_fixed(A, b, [], []);
    near(free - mean(free), Z, 1e-10);
    assert(sum(abs(free) < 1e-300) == 1);
    refused('inconsistent', '', @() min_quad_with_fixed(A, b + 1, [], []));
    near(min_quad_with_fixed(-A, b, [], []), -free, 1e-10);
    equalities_that_follow_from_others(A, B, known, Y);
    % a saddle
    D = sparse([0, 1; 1, 0]);
    near(min_quad_with_fixed(D, [2; 4], [], []), [-2; -1], 1e-14);
end

function equalities_that_follow_from_others(A, B, known, Y)
    n = size(A, 1);
    Aeq = sparse([1, 1, 2, 3], [8, 9, 40, 30], [1, -1, 2, 1], 3, n);
    Beq = [0; 2; 7];
    Z = min_quad_with_fixed(A, B, known, Y, Aeq, Beq);
    more = [Aeq; 2 * Aeq(1, :) - Aeq(3, :); 1e5 * Aeq(2, :); Aeq];
    [W, F, Lambda] = min_quad_with_fixed(A, B, known, Y, more, ...
                                         [Beq; -7; 2e5; Beq]);
    near(W, Z, 1e-9);
    assert(isequal(size(Lambda), [8, 2]) && numel(F.kept) == 3);
    u = setdiff(1:n, known)';
    near(2 * A(u, :) * W + B(u, :) + 2 * more(:, u)' * Lambda, zeros(numel(u), 2), 1e-9);
    lastwarn('');
    min_quad_with_fixed(A, B, known, Y, more, [Beq; 0; 2e5; Beq], F);
    [~, id] = lastwarn();
    assert(strcmp(id, 'min_quad_with_fixed:contradiction'), id);
    Z = min_quad_with_fixed(A, [], [], [], ones(2, n), [3; 3]);
    near(Z, 3 / n * ones(n, 1), 1e-10);
    % a matrix that the equalities leave singular
    refused('pivot', 'row', @() min_quad_with_fixed(sparse(n, n), [], [], [], Aeq, Beq));
    try
        min_quad_with_fixed(sparse(n, n), [], [], [], Aeq, Beq);
    catch e % which does not advise what this function does not take
        assert(isempty(strfind(e.message, 'options')) && isempty(strfind(e.message, 'sl_')));
    end
end

function help_texts()
    names = {'sparse_local', 'sparse_local_plan', 'sparse_local_constraints', 'sparse_local_make', ...
             'min_quad_with_fixed', 'heat'};
    for k = 1:numel(names)
        assert(numel(evalc(['help ', names{k}])) > 200, names{k});
    end
    text = evalc('help sparse_local');
    hidden = {'sparse_local', 'delete', 'disp', 'mldivide', 'rows', 'arrays'};
    list = methods('sparse_local');
    for k = 1:numel(list)
        if any(strcmp(list{k}, hidden)), continue; end
        assert(~isempty(strfind(text, ['F.', list{k}])), ['help does not name ', list{k}]);
    end
end

function readme()
    % The code of the page runs.
    here = fileparts(mfilename('fullpath'));
    text = fileread(fullfile(here, '..', 'README.md'));
    blocks = regexp(text, '```matlab\n(.*?)```', 'tokens');
    assert(numel(blocks) >= 2);
    for k = 1:numel(blocks)
        evalc(blocks{k}{1});
    end
end

function heat_example()
    text = evalc('x = heat();');
    assert(numel(x) == 40000 && ~isempty(strfind(text, '40000 vertices')));
end
