classdef sparse_local < handle
%SPARSE_LOCAL  A factor of a sparse symmetric matrix, for full and local solves.
%
%   F = sparse_local(A) factors A: sparse, real, symmetric, regular; both triangles or one of them.
%   F = sparse_local(A, 'NAME', VALUE, ...) with options:
%
%     'definite', true         refuses a matrix that is not positive definite
%     'pivoted', true          2x2 pivots, for KKT and other indefinite matrices
%     'regularization', 1e-8   replaces null pivots; 'signs', s: the sign of each pivot; then refine
%     'null_pivots', 'skip'    a singular matrix: a Laplacian, an elastic body
%     'mass', m                with it: solutions have m' * x = 0 in each component
%     'null_vector', Z         with it: the null vectors, other than constants
%     'null_tolerance', 'consistency_tolerance', 'growth_limit', 'error_limit': numbers
%     'triangle', 'lower'      reads one triangle only; 'upper'; 'auto': what is stored
%     'ordering', 'mindeg'     'nd' (default), 'mindeg', 'natural'; or 'perm', p
%     'purpose', 'one factor'  the first factor as early as possible
%     'block_size', 3          rows 3k+1 .. 3k+3 stay together in the order
%     'storage', 'float'       L in half the bytes
%     'threads', 4             of factorizations and full solves
%
%   Solves
%     x = F \ b                x = F.solve(b); b has any number of columns
%     x = F.local(I, b, J)     x(J) for a right-hand side that is b in rows I and 0 elsewhere
%     P = F.plan(I, J)         the same, prepared: x = P.solve(b)
%     [x, e] = F.refine(A, b)  with iterative refinement; e is the backward error that remains
%     r = F.rcond(A)           estimate of the reciprocal condition number
%   Entries of the inverse Z
%     d = F.diagonal(I)        Z(i, i) for i in I; F.diagonal(): all
%     z = F.pairs(I, J)        Z(I(k), J(k))
%     Z = F.block(I, J)        Z(I, J)
%   The factor
%     [l, s] = F.logdet()      log(abs(det(A))) and the sign of det(A)
%     [L, D, p] = F.factors()  A(p, p) = L * D * L'
%     s = F.info()             a struct: n, nnz_l, positive, negative, null, growth, ...
%   Other numbers
%     F.refactor(A)            new values in the same pattern; plans stay valid
%     F.rank_update(V, sigma)  A + V * diag(sigma) * V'; sigma is 1 if not given. The rows of a
%                              column of V are a clique
%     F.downdate(V)            A - V * V'
%     F.change_entries(B, A)   from the factor of A to that of B, in the cheapest way
%   Rows held at values
%     P = F.constraints(I)     x = P.solve(b, values); see sparse_local_constraints
%   F.close() releases the memory; so does clearing the last variable that refers to F.
%
%   I and J are row numbers, logical masks, or ':' for all rows. Rows in messages begin with 1.
%
%   Example
%     A = gallery('poisson', 100);
%     F = sparse_local(A);
%     x = F.local(17, 1, [17 18]);
%
%   See also sparse_local_plan, sparse_local_constraints, sparse_local_make.

    properties (SetAccess = private)
        n = 0; % rows of the matrix
    end
    properties (SetAccess = private, Hidden = true, Transient = true)
        id = 0; % of the object in sparse_local_mex; 0: none
    end

    methods
        function this = sparse_local(A, varargin)
            if ~issparse(A), A = sparse(A); end
            this.id = sparse_local_mex('create', double(A), this.arrays(varargin));
            this.n = size(A, 1);
        end

        function delete(this)
            this.close();
        end

        function close(this)
            % Releases the memory; later calls are refused.
            if this.id > 0, sparse_local_mex('free', this.id); end
            this.id = 0;
        end

        function x = mldivide(this, b)
            % F \ b: x everywhere for b everywhere.
            x = this.solve(b);
        end

        function x = solve(this, b)
            % x = F.solve(b): x everywhere for b everywhere.
            if ~isreal(b)
                x = complex(this.solve(real(b)), this.solve(imag(b)));
            else
                x = sparse_local_mex('solve', this.id, full(double(b)));
            end
        end

        function x = local(this, bset, b, xset)
            % x = F.local(I, b, J): x in rows J, for b in rows I and 0 elsewhere.
            bset = this.rows(bset);
            b = full(double(b));
            if isvector(b) && ~ischar(bset) && numel(b) == numel(bset), b = b(:); end
            x = sparse_local_mex('local', this.id, bset, b, this.rows(xset));
        end

        function P = plan(this, bset, xset)
            % P = F.plan(I, J): local solves, prepared; see sparse_local_plan.
            P = sparse_local_plan(this, bset, xset);
        end

        function [x, e] = refine(this, A, b, steps)
            % [x, e] = F.refine(A, b): solves and refines; e is the backward error that remains.
            if nargin < 4, steps = 5; end
            [x, e] = sparse_local_mex('refine', this.id, double(A), full(double(b)), steps);
        end

        function r = rcond(this, A)
            % r = F.rcond(A): estimate of the reciprocal condition number in the one-norm.
            r = sparse_local_mex('rcond', this.id, double(A));
        end

        function d = diagonal(this, list)
            % d = F.diagonal(I): diagonal entries of the inverse.
            if nargin < 2, list = ':'; end
            d = sparse_local_mex('diagonal', this.id, this.rows(list));
        end

        function z = pairs(this, rows, columns)
            % z = F.pairs(I, J): entries (I(k), J(k)) of the inverse.
            z = sparse_local_mex('pairs', this.id, this.rows(rows), this.rows(columns));
        end

        function Z = block(this, rows, columns)
            % Z = F.block(I, J): rows I and columns J of the inverse.
            Z = sparse_local_mex('block', this.id, this.rows(rows), this.rows(columns));
        end

        function [l, s] = logdet(this)
            % [l, s] = F.logdet(): log(abs(det(A))) and the sign of det(A).
            [l, s] = sparse_local_mex('logdet', this.id);
        end

        function [L, D, p] = factors(this)
            % [L, D, p] = F.factors(): A(p, p) = L * D * L'.
            [L, d, e, p] = sparse_local_mex('factors', this.id);
            D = spdiags([e, d, [0; e(1:end - 1)]], -1:1, this.n, this.n);
        end

        function s = info(this)
            % s = F.info(): counts and sizes of the factor.
            s = sparse_local_mex('info', this.id);
        end

        function refactor(this, A)
            % F.refactor(A): new values in the same pattern; plans stay valid.
            sparse_local_mex('refactor', this.id, double(A));
        end

        function rank_update(this, V, sigma)
            % F.rank_update(V, sigma): the factor of A + V * diag(sigma) * V'; sigma is 1 if not given.
            V = sparse(double(V));
            if nargin < 3, sigma = ones(size(V, 2), 1); end
            sparse_local_mex('rank_update', this.id, V, double(sigma(:)));
        end

        function downdate(this, V)
            % F.downdate(V): the factor of A - V * V'.
            this.rank_update(V, -ones(size(V, 2), 1));
        end

        function change_entries(this, B, A)
            % F.change_entries(B, A): from the factor of A to that of B, in the cheapest way.
            [i, j, d] = find(tril(B - A));
            sparse_local_mex('change_entries', this.id, double(B), i(:), j(:), d(:));
        end

        function P = constraints(this, list)
            % P = F.constraints(I): rows held at values, at first none if I is not given; see
            % sparse_local_constraints.
            if nargin < 2, list = []; end
            P = sparse_local_constraints(this, list);
        end

        function disp(this)
            fprintf('  a factor of %d rows; help sparse_local\n', this.n);
        end
    end

    methods (Static, Hidden = true)
        function list = rows(list)
            % Row numbers from numbers, a logical mask or ':'.
            if islogical(list)
                list = find(list);
            elseif ~ischar(list)
                list = full(double(list));
            end
            if ~ischar(list), list = list(:); end
        end

        function list = arrays(list)
            % Values of options as full arrays of doubles.
            for k = 2:2:numel(list)
                if isnumeric(list{k}), list{k} = full(double(list{k})); end
            end
        end
    end
end
